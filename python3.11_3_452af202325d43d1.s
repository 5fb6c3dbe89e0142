	.att_syntax
	.file	"3"
	.section	.rodata,"a",@progbits
	.p2align	6, 0x0
.LCPI0_0:
	.long	0
	.long	2
	.long	4
	.long	6
	.long	8
	.long	10
	.long	12
	.long	14
	.long	16
	.long	18
	.long	20
	.long	22
	.long	24
	.long	26
	.long	28
	.long	30
	.section	.lrodata.cst4,"aMl",@progbits,4
	.p2align	2, 0x0
.LCPI0_1:
	.long	1
.LCPI0_2:
	.long	0x3f800000
.LCPI0_3:
	.long	0x45800800
.LCPI0_4:
	.long	0x7fffffff
.LCPI0_5:
	.long	0x27800000
.LCPI0_6:
	.long	0x57800000
.LCPI0_7:
	.long	0x35000000
.LCPI0_8:
	.long	0x3e99999a
.LCPI0_9:
	.long	0x7f800000
.LCPI0_10:
	.long	0xbf333333
.LCPI0_11:
	.long	0xbe99999a
.LCPI0_12:
	.long	0x3716feb5
.LCPI0_13:
	.long	2
.LCPI0_14:
	.long	3
.LCPI0_15:
	.long	0xbf800000
.LCPI0_16:
	.long	2000
	.section	.lrodata.cst8,"aMl",@progbits,8
	.p2align	2, 0x0
.LCPI0_17:
	.long	0x3f800000
	.long	0xbf800000
	.section	.ltext,"axl",@progbits
	.globl	camera
	.prefalign	4, .Lfunc_end0, nop
	.type	camera,@function
camera:
	endbr64
	pushq	%rbp
	movq	%rsp, %rbp
	pushq	%r15
	pushq	%r14
	pushq	%r13
	pushq	%r12
	pushq	%rbx
	andq	$-64, %rsp
	subq	$512, %rsp
	movq	208(%rdi), %rax
	movq	8(%rsi), %r11
	movq	200(%rdi), %r9
	movq	(%rsi), %r8
	movslq	28(%rdi), %rdx
	movslq	24(%rdi), %rcx
	imulq	%rax, %r11
	addq	48(%rdi), %r11
	imulq	%r9, %r8
	addq	40(%rdi), %r8
	movq	%rcx, 40(%rsp)
	addq	%r11, %rax
	movq	%r8, 56(%rsp)
	cmpq	%rdx, %rax
	cmovgeq	%rdx, %rax
	addq	%r8, %r9
	cmpq	%rcx, %r9
	movq	%rax, 64(%rsp)
	cmovgeq	%rcx, %r9
	movq	%r9, %rcx
	subq	%r8, %rcx
	testq	%rcx, %rcx
	jle	.LBB0_38
	movq	64(%rsp), %rax
	subq	%r11, %rax
	testq	%rax, %rax
	jle	.LBB0_38
	movq	%rdx, 80(%rsp)
	movabsq	$9223372036854775792, %rdx
	movq	8(%rdi), %rax
	movq	16(%rdi), %rsi
	movq	(%rdi), %r8
	movabsq	$.LCPI0_10, %rbx
	movabsq	$.LCPI0_11, %r14
	movabsq	$.LCPI0_12, %r15
	movq	%r11, 48(%rsp)
	movq	%rcx, 112(%rsp)
	andq	%rcx, %rdx
	addq	56(%rsp), %rdx
	movq	%rax, 104(%rsp)
	movq	%rsi, 96(%rsp)
	movq	%rdx, 88(%rsp)
	cmpq	$16, %rcx
	jae	.LBB0_3
.LBB0_12:
	testb	$15, 112(%rsp)
	movq	48(%rsp), %r11
	movq	80(%rsp), %rax
	je	.LBB0_38
	vcvtsi2ssl	40(%rsp), %xmm15, %xmm0
	movabsq	$.LCPI0_3, %rcx
	movabsq	$.LCPI0_2, %rdx
	movabsq	$.LCPI0_4, %rsi
	movl	$3, %r13d
	vxorps	%xmm3, %xmm3, %xmm3
	movq	%r9, 120(%rsp)
	vmovss	(%rcx), %xmm4
	movabsq	$.LCPI0_6, %rcx
	vmovss	(%rdx), %xmm2
	movabsq	$.LCPI0_5, %rdx
	vbroadcastss	(%rsi), %xmm7
	vbroadcastss	(%rsi), %xmm5
	vmovss	(%rcx), %xmm6
	movabsq	$.LCPI0_7, %rcx
	vmovss	(%rdx), %xmm8
	movabsq	$.LCPI0_8, %rdx
	vmovss	(%rcx), %xmm9
	movabsq	$.LCPI0_9, %rcx
	vmovss	(%rdx), %xmm10
	vmovss	(%rcx), %xmm11
	vcvtsi2ss	%eax, %xmm15, %xmm1
	jmp	.LBB0_14
	.p2align	4
.LBB0_37:
	movq	48(%rsp), %r11
	incq	%r11
	cmpq	64(%rsp), %r11
	je	.LBB0_38
.LBB0_14:
	leal	1(%r11,%r11), %eax
	movq	88(%rsp), %r10
	movq	%r11, 48(%rsp)
	vcvtsi2ss	%eax, %xmm15, %xmm12
	movq	40(%rsp), %rax
	vsubss	%xmm12, %xmm1, %xmm12
	movl	%eax, %esi
	imull	%r11d, %esi
	vdivss	%xmm1, %xmm12, %xmm12
	movq	%rsi, 128(%rsp)
	jmp	.LBB0_15
.LBB0_27:
	vmovaps	%xmm21, %xmm19
	xorl	%esi, %esi
.LBB0_35:
	leal	(%rsi,%rdx,4), %ecx
	movq	120(%rsp), %r9
	movq	128(%rsp), %rsi
.LBB0_36:
	movq	104(%rsp), %rdx
	movq	96(%rsp), %rdi
	vaddss	%xmm19, %xmm13, %xmm13
	leal	(%rsi,%r10), %eax
	incq	%r10
	cltq
	vmovss	%xmm13, (%rdx,%rax,4)
	movl	%ecx, (%rdi,%rax,4)
	cmpq	%r9, %r10
	je	.LBB0_37
.LBB0_15:
	leal	1(%r10,%r10), %ecx
	vmovss	(%r8), %xmm17
	vmovss	4(%r8), %xmm18
	vmovss	8(%r8), %xmm19
	vmovaps	%xmm6, %xmm21
	vcvtsi2ss	%ecx, %xmm15, %xmm13
	vsubss	%xmm0, %xmm13, %xmm13
	vdivss	%xmm0, %xmm13, %xmm13
	vmulss	24(%r8), %xmm13, %xmm14
	vmulss	28(%r8), %xmm13, %xmm15
	vmulss	32(%r8), %xmm13, %xmm13
	vaddss	20(%r8), %xmm13, %xmm16
	vaddss	12(%r8), %xmm14, %xmm14
	vmulss	36(%r8), %xmm12, %xmm13
	vaddss	16(%r8), %xmm15, %xmm15
	vaddss	%xmm13, %xmm14, %xmm14
	vmulss	40(%r8), %xmm12, %xmm13
	vaddss	%xmm13, %xmm15, %xmm13
	vmulss	44(%r8), %xmm12, %xmm15
	vmulss	%xmm13, %xmm13, %xmm20
	vaddss	%xmm15, %xmm16, %xmm16
	vmulss	%xmm14, %xmm14, %xmm15
	vaddss	%xmm20, %xmm15, %xmm15
	vmulss	%xmm16, %xmm16, %xmm20
	vaddss	%xmm15, %xmm20, %xmm15
	vsqrtss	%xmm15, %xmm15, %xmm15
	vdivss	%xmm15, %xmm2, %xmm20
	vmulss	%xmm20, %xmm14, %xmm14
	vandps	%xmm5, %xmm14, %xmm15
	vucomiss	%xmm15, %xmm8
	ja	.LBB0_17
	vdivss	%xmm14, %xmm2, %xmm21
.LBB0_17:
	vmulss	%xmm20, %xmm13, %xmm15
	vsubss	%xmm17, %xmm3, %xmm13
	vmulss	%xmm20, %xmm16, %xmm16
	vsubss	%xmm18, %xmm3, %xmm20
	vsubss	%xmm19, %xmm3, %xmm22
	vmulss	%xmm4, %xmm14, %xmm24
	vmulss	%xmm14, %xmm13, %xmm13
	vmulss	%xmm15, %xmm20, %xmm20
	vsubss	%xmm14, %xmm24, %xmm25
	vaddss	%xmm20, %xmm13, %xmm13
	vmulss	%xmm16, %xmm22, %xmm20
	vsubss	%xmm25, %xmm24, %xmm24
	vaddss	%xmm13, %xmm20, %xmm13
	vsubss	%xmm24, %xmm14, %xmm25
	vmulss	%xmm4, %xmm13, %xmm20
	vmulss	%xmm13, %xmm14, %xmm23
	vsubss	%xmm13, %xmm20, %xmm22
	vaddss	%xmm23, %xmm17, %xmm28
	vsubss	%xmm22, %xmm20, %xmm22
	vmulss	%xmm22, %xmm24, %xmm26
	vsubss	%xmm22, %xmm13, %xmm20
	vmulss	%xmm22, %xmm25, %xmm27
	vsubss	%xmm26, %xmm23, %xmm26
	vmulss	%xmm20, %xmm24, %xmm24
	vmulss	%xmm20, %xmm25, %xmm25
	vsubss	%xmm27, %xmm26, %xmm26
	vsubss	%xmm24, %xmm26, %xmm24
	vsubss	%xmm17, %xmm28, %xmm26
	vsubss	%xmm26, %xmm28, %xmm27
	vsubss	%xmm26, %xmm23, %xmm23
	vsubss	%xmm24, %xmm25, %xmm24
	vsubss	%xmm27, %xmm17, %xmm17
	vaddss	%xmm17, %xmm23, %xmm17
	vaddss	%xmm24, %xmm17, %xmm17
	vaddss	%xmm17, %xmm28, %xmm17
	vandps	%xmm7, %xmm17, %xmm23
	vaddss	%xmm2, %xmm23, %xmm23
	vmulss	%xmm9, %xmm23, %xmm24
	vandps	%xmm7, %xmm15, %xmm23
	vucomiss	%xmm23, %xmm8
	vmovaps	%xmm6, %xmm23
	ja	.LBB0_19
	vdivss	%xmm15, %xmm2, %xmm23
.LBB0_19:
	vmulss	%xmm4, %xmm15, %xmm26
	vmulss	%xmm13, %xmm15, %xmm25
	vsubss	%xmm15, %xmm26, %xmm27
	vaddss	%xmm25, %xmm18, %xmm30
	vsubss	%xmm27, %xmm26, %xmm26
	vmulss	%xmm22, %xmm26, %xmm28
	vsubss	%xmm26, %xmm15, %xmm27
	vmulss	%xmm20, %xmm26, %xmm26
	vmulss	%xmm22, %xmm27, %xmm29
	vsubss	%xmm28, %xmm25, %xmm28
	vmulss	%xmm20, %xmm27, %xmm27
	vsubss	%xmm29, %xmm28, %xmm28
	vsubss	%xmm26, %xmm28, %xmm26
	vsubss	%xmm18, %xmm30, %xmm28
	vsubss	%xmm28, %xmm30, %xmm29
	vsubss	%xmm28, %xmm25, %xmm25
	vsubss	%xmm26, %xmm27, %xmm26
	vsubss	%xmm29, %xmm18, %xmm18
	vaddss	%xmm18, %xmm25, %xmm18
	vaddss	%xmm26, %xmm18, %xmm18
	vaddss	%xmm18, %xmm30, %xmm18
	vandps	%xmm7, %xmm18, %xmm25
	vaddss	%xmm2, %xmm25, %xmm25
	vmulss	%xmm9, %xmm25, %xmm26
	vandps	%xmm7, %xmm16, %xmm25
	vucomiss	%xmm25, %xmm8
	vmovaps	%xmm6, %xmm25
	ja	.LBB0_21
	vdivss	%xmm16, %xmm2, %xmm25
.LBB0_21:
	vmulss	%xmm4, %xmm16, %xmm28
	vmulss	%xmm13, %xmm16, %xmm27
	vaddss	%xmm2, %xmm24, %xmm24
	vaddss	%xmm2, %xmm26, %xmm26
	xorl	%ecx, %ecx
	vsubss	%xmm16, %xmm28, %xmm29
	vsubss	%xmm29, %xmm28, %xmm28
	vsubss	%xmm28, %xmm16, %xmm29
	vmulss	%xmm22, %xmm28, %xmm30
	vmulss	%xmm20, %xmm28, %xmm28
	vmulss	%xmm22, %xmm29, %xmm22
	vmulss	%xmm20, %xmm29, %xmm20
	vsubss	%xmm30, %xmm27, %xmm29
	vsubss	%xmm22, %xmm29, %xmm22
	vsubss	%xmm28, %xmm22, %xmm22
	vsubss	%xmm22, %xmm20, %xmm20
	vaddss	%xmm27, %xmm19, %xmm22
	vsubss	%xmm19, %xmm22, %xmm28
	vsubss	%xmm28, %xmm22, %xmm29
	vsubss	%xmm28, %xmm27, %xmm27
	vsubss	%xmm29, %xmm19, %xmm19
	vaddss	%xmm19, %xmm27, %xmm19
	vaddss	%xmm20, %xmm19, %xmm19
	vaddss	%xmm19, %xmm22, %xmm20
	vsubss	%xmm17, %xmm3, %xmm22
	vmulss	%xmm22, %xmm21, %xmm19
	vandps	%xmm7, %xmm21, %xmm21
	vmulss	%xmm24, %xmm21, %xmm21
	vsubss	%xmm18, %xmm3, %xmm24
	vsubss	%xmm21, %xmm19, %xmm27
	vaddss	%xmm19, %xmm21, %xmm19
	vmulss	%xmm24, %xmm23, %xmm21
	vandps	%xmm7, %xmm23, %xmm23
	vmulss	%xmm26, %xmm23, %xmm23
	vsubss	%xmm23, %xmm21, %xmm26
	vaddss	%xmm21, %xmm23, %xmm21
	vsubss	%xmm20, %xmm3, %xmm23
	vmaxss	%xmm26, %xmm27, %xmm26
	vandps	%xmm7, %xmm20, %xmm27
	vminss	%xmm21, %xmm19, %xmm19
	vmulss	%xmm25, %xmm23, %xmm21
	vandps	%xmm7, %xmm25, %xmm25
	vaddss	%xmm10, %xmm27, %xmm27
	vmulss	%xmm9, %xmm27, %xmm27
	vaddss	%xmm10, %xmm27, %xmm27
	vmulss	%xmm27, %xmm25, %xmm25
	vsubss	%xmm25, %xmm21, %xmm27
	vaddss	%xmm25, %xmm21, %xmm21
	vsubss	%xmm13, %xmm11, %xmm25
	vminss	%xmm21, %xmm19, %xmm21
	vsubss	%xmm13, %xmm3, %xmm19
	vmaxss	%xmm27, %xmm26, %xmm26
	vminss	%xmm25, %xmm21, %xmm21
	vmaxss	%xmm19, %xmm26, %xmm19
	vucomiss	%xmm19, %xmm21
	jb	.LBB0_36
	vmulss	%xmm22, %xmm14, %xmm22
	vmulss	%xmm24, %xmm15, %xmm24
	vmulss	%xmm23, %xmm16, %xmm23
	movl	$1, %esi
	movl	$1, %ecx
	movl	$1, %r11d
	xorl	%edx, %edx
	xorl	%r9d, %r9d
	vaddss	%xmm24, %xmm22, %xmm22
	vmovaps	%xmm11, %xmm24
	vaddss	%xmm22, %xmm23, %xmm22
	vmovaps	%xmm2, %xmm23
	.p2align	4
.LBB0_23:
	vmulss	%xmm19, %xmm14, %xmm25
	vmulss	%xmm19, %xmm15, %xmm26
	vmulss	%xmm19, %xmm16, %xmm27
	incl	%edx
	vaddss	%xmm25, %xmm17, %xmm25
	vaddss	%xmm26, %xmm18, %xmm26
	vaddss	%xmm27, %xmm20, %xmm27
	vmulss	%xmm25, %xmm25, %xmm25
	vmulss	%xmm26, %xmm26, %xmm26
	vaddss	%xmm26, %xmm25, %xmm25
	vmulss	%xmm27, %xmm27, %xmm26
	vmovss	(%r15), %xmm27
	vsqrtss	%xmm25, %xmm25, %xmm25
	vaddss	(%rbx), %xmm25, %xmm25
	vmulss	%xmm25, %xmm25, %xmm25
	vaddss	%xmm25, %xmm26, %xmm25
	vsqrtss	%xmm25, %xmm25, %xmm25
	vaddss	(%r14), %xmm25, %xmm25
	vandps	%xmm5, %xmm25, %xmm26
	vucomiss	%xmm26, %xmm27
	ja	.LBB0_35
	cmpl	$2, %r11d
	jne	.LBB0_30
	testb	%r9b, %r9b
	je	.LBB0_30
	vucomiss	%xmm24, %xmm25
	ja	.LBB0_27
.LBB0_30:
	vcmpnltss	%xmm25, %xmm24, %k0
	vcmpneq_oqss	%xmm11, %xmm24, %k1
	xorl	%edi, %edi
	cmpl	$2, %r11d
	vmovaps	%xmm23, %xmm27
	sete	%dil
	kandw	%k0, %k1, %k0
	kmovd	%k0, %r9d
	andb	$1, %r9b
	cmpl	$3, %r11d
	setne	%al
	vucomiss	%xmm25, %xmm3
	kmovd	%eax, %k1
	movabsq	$.LCPI0_17, %rax
	seta	%r12b
	cmoval	%r13d, %r11d
	kmovd	%r12d, %k2
	vmovss	(%rax,%rdi,4), %xmm27 {%k2}
	vmovss	%xmm27, %xmm23, %xmm23 {%k1}
	vmulss	%xmm26, %xmm23, %xmm26
	vaddss	%xmm26, %xmm19, %xmm19
	cmpl	$1, %r11d
	jne	.LBB0_33
	vucomiss	%xmm24, %xmm25
	jbe	.LBB0_33
	vcmpltss	%xmm22, %xmm19, %k1
	movabsq	$.LCPI0_9, %rax
	vmaxss	%xmm19, %xmm22, %xmm19
	movl	$2, %r11d
	xorl	%r9d, %r9d
	vmovss	(%rax), %xmm25 {%k1}
.LBB0_33:
	vucomiss	%xmm19, %xmm21
	vmovaps	%xmm25, %xmm24
	jb	.LBB0_34
	incl	%ecx
	cmpl	$2001, %ecx
	jne	.LBB0_23
	movl	$2000, %edx
	movl	$2, %esi
	jmp	.LBB0_35
.LBB0_34:
	vmovaps	%xmm21, %xmm19
	xorl	%esi, %esi
	movl	%ecx, %edx
	jmp	.LBB0_35
.LBB0_38:
	leaq	-40(%rbp), %rsp
	popq	%rbx
	popq	%r12
	popq	%r13
	popq	%r14
	popq	%r15
	popq	%rbp
	vzeroupper
	retq
.LBB0_3:
	vcvtsi2ssl	80(%rsp), %xmm15, %xmm0
	movq	56(%rsp), %rax
	movq	48(%rsp), %rdx
	movabsq	$.LCPI0_14, %r10
	movabsq	$.LCPI0_15, %r12
	movabsq	$.LCPI0_16, %r13
	vxorps	%xmm14, %xmm14, %xmm14
	vpbroadcastd	%eax, %zmm3
	movabsq	$.LCPI0_0, %rax
	vmovss	%xmm0, 76(%rsp)
	vcvtsi2ssl	40(%rsp), %xmm15, %xmm0
	vbroadcastss	%xmm0, %zmm1
	vpaddd	%zmm3, %zmm3, %zmm0
	vpaddd	(%rax), %zmm0, %zmm2
	vmovd	%xmm0, %eax
	vpextrd	$1, %xmm2, %ecx
	vmovdqu64	%zmm2, 192(%rsp)
	subl	%eax, %ecx
	movabsq	$.LCPI0_1, %rax
	vpbroadcastd	(%rax), %zmm6
	movabsq	$.LCPI0_4, %rax
	shll	$4, %ecx
	vbroadcastss	(%rax), %zmm8
	movabsq	$.LCPI0_5, %rax
	vpbroadcastd	%ecx, %zmm0
	movabsq	$.LCPI0_2, %rcx
	vbroadcastss	(%rax), %zmm2
	movabsq	$.LCPI0_6, %rax
	vbroadcastss	(%rcx), %zmm4
	movabsq	$.LCPI0_3, %rcx
	vmovdqu64	%zmm0, 128(%rsp)
	vbroadcastss	(%rax), %zmm3
	movabsq	$.LCPI0_7, %rax
	vbroadcastss	(%rcx), %zmm5
	vbroadcastss	(%rax), %zmm11
	movabsq	$.LCPI0_8, %rax
	vmovups	%zmm2, 384(%rsp)
	vbroadcastss	(%rax), %zmm2
	movabsq	$.LCPI0_9, %rax
	vmovups	%zmm3, 320(%rsp)
	vbroadcastss	(%rax), %zmm3
	movabsq	$.LCPI0_13, %rax
	vmovups	%zmm2, 256(%rsp)
	jmp	.LBB0_4
	.p2align	4
.LBB0_11:
	movq	%r11, %rdx
	incq	%rdx
	cmpq	64(%rsp), %rdx
	je	.LBB0_12
.LBB0_4:
	vmovss	76(%rsp), %xmm2
	leal	1(%rdx,%rdx), %ecx
	vmovdqu64	192(%rsp), %zmm16
	movq	40(%rsp), %rsi
	movq	%rdx, %r11
	imull	%edx, %esi
	movq	56(%rsp), %rdx
	vcvtsi2ss	%ecx, %xmm15, %xmm0
	vsubss	%xmm0, %xmm2, %xmm0
	vdivss	%xmm2, %xmm0, %xmm15
	jmp	.LBB0_5
	.p2align	4
.LBB0_6:
	vxorps	%xmm0, %xmm0, %xmm0
.LBB0_10:
	movq	104(%rsp), %rdi
	vaddps	%zmm24, %zmm17, %zmm2
	vpaddd	128(%rsp), %zmm16, %zmm16
	leal	(%rsi,%rdx), %ecx
	addq	$16, %rdx
	movslq	%ecx, %rcx
	vmovups	%zmm2, (%rdi,%rcx,4)
	movq	96(%rsp), %rdi
	vmovdqu64	%zmm0, (%rdi,%rcx,4)
	cmpq	88(%rsp), %rdx
	je	.LBB0_11
.LBB0_5:
	vpord	%zmm6, %zmm16, %zmm12
	vmulss	36(%r8), %xmm15, %xmm18
	vbroadcastss	(%r8), %zmm0
	vbroadcastss	4(%r8), %zmm2
	vbroadcastss	8(%r8), %zmm23
	vxorps	%xmm7, %xmm7, %xmm7
	vcvtdq2ps	%zmm12, %zmm12
	vsubps	%zmm1, %zmm12, %zmm12
	vdivps	%zmm1, %zmm12, %zmm12
	vbroadcastss	%xmm18, %zmm18
	vmulps	24(%r8){1to16}, %zmm12, %zmm13
	vmulps	28(%r8){1to16}, %zmm12, %zmm17
	vmulps	32(%r8){1to16}, %zmm12, %zmm12
	vaddps	12(%r8){1to16}, %zmm13, %zmm13
	vaddps	16(%r8){1to16}, %zmm17, %zmm17
	vaddps	20(%r8){1to16}, %zmm12, %zmm12
	vaddps	%zmm18, %zmm13, %zmm13
	vmulss	40(%r8), %xmm15, %xmm18
	vmulps	%zmm13, %zmm13, %zmm9
	vbroadcastss	%xmm18, %zmm18
	vaddps	%zmm18, %zmm17, %zmm17
	vmulss	44(%r8), %xmm15, %xmm18
	vmulps	%zmm17, %zmm17, %zmm19
	vbroadcastss	%xmm18, %zmm18
	vaddps	%zmm18, %zmm12, %zmm12
	vaddps	%zmm19, %zmm9, %zmm18
	vmulps	%zmm12, %zmm12, %zmm9
	vaddps	%zmm18, %zmm9, %zmm18
	vsqrtps	%zmm18, %zmm18
	vdivps	%zmm18, %zmm4, %zmm20
	vmulps	%zmm20, %zmm17, %zmm19
	vmulps	%zmm20, %zmm13, %zmm18
	vsubss	%xmm2, %xmm7, %xmm13
	vmulps	%zmm20, %zmm12, %zmm20
	vsubss	%xmm0, %xmm7, %xmm12
	vsubss	%xmm23, %xmm7, %xmm17
	vbroadcastss	%xmm12, %zmm12
	vbroadcastss	%xmm13, %zmm13
	vbroadcastss	%xmm17, %zmm17
	vmulps	%zmm5, %zmm18, %zmm7
	vandps	%zmm8, %zmm19, %zmm10
	vmulps	%zmm18, %zmm12, %zmm12
	vmulps	%zmm19, %zmm13, %zmm13
	vmulps	%zmm20, %zmm17, %zmm9
	vsubps	%zmm18, %zmm7, %zmm22
	vaddps	%zmm13, %zmm12, %zmm12
	vaddps	%zmm12, %zmm9, %zmm17
	vmulps	%zmm5, %zmm17, %zmm13
	vmulps	%zmm17, %zmm18, %zmm12
	vsubps	%zmm17, %zmm13, %zmm21
	vsubps	%zmm21, %zmm13, %zmm13
	vsubps	%zmm22, %zmm7, %zmm21
	vaddps	%zmm12, %zmm0, %zmm7
	vmulps	%zmm13, %zmm21, %zmm25
	vsubps	%zmm21, %zmm18, %zmm22
	vsubps	%zmm13, %zmm17, %zmm24
	vmulps	%zmm13, %zmm22, %zmm26
	vsubps	%zmm25, %zmm12, %zmm25
	vmulps	%zmm24, %zmm21, %zmm21
	vmulps	%zmm24, %zmm22, %zmm22
	vsubps	%zmm26, %zmm25, %zmm25
	vsubps	%zmm21, %zmm25, %zmm21
	vsubps	%zmm0, %zmm7, %zmm25
	vsubps	%zmm25, %zmm7, %zmm26
	vsubps	%zmm25, %zmm12, %zmm12
	vsubps	%zmm21, %zmm22, %zmm21
	vsubps	%zmm26, %zmm0, %zmm0
	vaddps	%zmm0, %zmm12, %zmm0
	vmulps	%zmm5, %zmm19, %zmm12
	vsubps	%zmm19, %zmm12, %zmm9
	vaddps	%zmm21, %zmm0, %zmm0
	vsubps	%zmm9, %zmm12, %zmm12
	vaddps	%zmm0, %zmm7, %zmm21
	vmulps	%zmm17, %zmm19, %zmm0
	vmulps	%zmm13, %zmm12, %zmm25
	vsubps	%zmm12, %zmm19, %zmm22
	vmulps	%zmm24, %zmm12, %zmm12
	vaddps	%zmm0, %zmm2, %zmm7
	vmulps	%zmm13, %zmm22, %zmm26
	vsubps	%zmm25, %zmm0, %zmm25
	vmulps	%zmm24, %zmm22, %zmm22
	vsubps	%zmm26, %zmm25, %zmm25
	vsubps	%zmm12, %zmm25, %zmm12
	vsubps	%zmm2, %zmm7, %zmm25
	vsubps	%zmm25, %zmm7, %zmm26
	vsubps	%zmm25, %zmm0, %zmm0
	vsubps	%zmm12, %zmm22, %zmm12
	vsubps	%zmm26, %zmm2, %zmm2
	vaddps	%zmm2, %zmm0, %zmm0
	vmulps	%zmm5, %zmm20, %zmm2
	vsubps	%zmm20, %zmm2, %zmm9
	vaddps	%zmm12, %zmm0, %zmm0
	vsubps	%zmm9, %zmm2, %zmm2
	vaddps	%zmm0, %zmm7, %zmm22
	vmulps	%zmm17, %zmm20, %zmm0
	vmulps	%zmm13, %zmm2, %zmm25
	vsubps	%zmm2, %zmm20, %zmm12
	vmulps	%zmm24, %zmm2, %zmm2
	vaddps	%zmm0, %zmm23, %zmm7
	vandps	%zmm8, %zmm22, %zmm26
	vaddps	%zmm4, %zmm26, %zmm26
	vmulps	%zmm13, %zmm12, %zmm13
	vsubps	%zmm25, %zmm0, %zmm9
	vmulps	%zmm24, %zmm12, %zmm12
	vmulps	%zmm11, %zmm26, %zmm26
	vsubps	%zmm13, %zmm9, %zmm13
	vmovups	320(%rsp), %zmm9
	vaddps	%zmm4, %zmm26, %zmm26
	vsubps	%zmm2, %zmm13, %zmm2
	vsubps	%zmm23, %zmm7, %zmm13
	vsubps	%zmm13, %zmm7, %zmm24
	vsubps	%zmm13, %zmm0, %zmm0
	vsubps	%zmm2, %zmm12, %zmm2
	vandps	%zmm8, %zmm21, %zmm13
	vaddps	%zmm4, %zmm13, %zmm13
	vsubps	%zmm24, %zmm23, %zmm23
	vdivps	%zmm18, %zmm4, %zmm24
	vmulps	%zmm11, %zmm13, %zmm13
	vaddps	%zmm23, %zmm0, %zmm0
	vaddps	%zmm4, %zmm13, %zmm13
	vaddps	%zmm2, %zmm0, %zmm0
	vaddps	%zmm0, %zmm7, %zmm23
	vmovups	384(%rsp), %zmm7
	vandps	%zmm8, %zmm18, %zmm0
	vandps	%zmm8, %zmm23, %zmm27
	vcmpltps	%zmm7, %zmm0, %k1
	vsubps	%zmm21, %zmm14, %zmm0
	vmovaps	%zmm9, %zmm24 {%k1}
	vandps	%zmm8, %zmm24, %zmm2
	vcmpltps	%zmm7, %zmm10, %k1
	vandps	%zmm8, %zmm20, %zmm10
	vmulps	%zmm0, %zmm24, %zmm12
	vdivps	%zmm19, %zmm4, %zmm24
	vmulps	%zmm13, %zmm2, %zmm2
	vsubps	%zmm2, %zmm12, %zmm13
	vaddps	%zmm12, %zmm2, %zmm12
	vsubps	%zmm22, %zmm14, %zmm2
	vmovaps	%zmm9, %zmm24 {%k1}
	vmulps	%zmm2, %zmm24, %zmm25
	vandps	%zmm8, %zmm24, %zmm24
	vcmpltps	%zmm7, %zmm10, %k1
	vsubps	%zmm17, %zmm14, %zmm7
	vmulps	%zmm26, %zmm24, %zmm24
	vsubps	%zmm24, %zmm25, %zmm26
	vaddps	%zmm25, %zmm24, %zmm24
	vdivps	%zmm20, %zmm4, %zmm25
	vminps	%zmm24, %zmm12, %zmm24
	vsubps	%zmm23, %zmm14, %zmm12
	vmaxps	%zmm26, %zmm13, %zmm13
	vmovaps	%zmm9, %zmm25 {%k1}
	vmovups	256(%rsp), %zmm9
	vmulps	%zmm25, %zmm12, %zmm26
	vandps	%zmm8, %zmm25, %zmm25
	vaddps	%zmm9, %zmm27, %zmm27
	vmulps	%zmm11, %zmm27, %zmm27
	vaddps	%zmm9, %zmm27, %zmm27
	vmulps	%zmm27, %zmm25, %zmm25
	vsubps	%zmm25, %zmm26, %zmm27
	vaddps	%zmm25, %zmm26, %zmm25
	vmaxps	%zmm27, %zmm13, %zmm13
	vminps	%zmm25, %zmm24, %zmm25
	vmaxps	%zmm7, %zmm13, %zmm24
	vsubps	%zmm17, %zmm3, %zmm7
	vminps	%zmm7, %zmm25, %zmm25
	vcmpleps	%zmm25, %zmm24, %k1
	kortestw	%k1, %k1
	je	.LBB0_6
	vmulps	%zmm0, %zmm18, %zmm0
	vmulps	%zmm2, %zmm19, %zmm2
	vmulps	%zmm12, %zmm20, %zmm7
	vcmpleps	%zmm25, %zmm24, %k2
	kxorw	%k0, %k0, %k0
	movl	$1, %ecx
	vmovaps	%zmm3, %zmm13
	vmovdqa64	%zmm6, %zmm27
	vmovaps	%zmm4, %zmm29
	vaddps	%zmm2, %zmm0, %zmm0
	vmovaps	%zmm24, %zmm2
	vaddps	%zmm0, %zmm7, %zmm26
	.p2align	4
.LBB0_8:
	vmulps	%zmm2, %zmm18, %zmm0
	vmovaps	%zmm2, %zmm12
	vmulps	%zmm2, %zmm19, %zmm2
	vbroadcastss	(%rbx), %zmm9
	vmulps	%zmm12, %zmm20, %zmm7
	kandw	%k1, %k2, %k3
	vaddps	%zmm0, %zmm21, %zmm0
	vaddps	%zmm2, %zmm22, %zmm2
	vaddps	%zmm7, %zmm23, %zmm7
	vmulps	%zmm0, %zmm0, %zmm0
	vmulps	%zmm2, %zmm2, %zmm2
	vaddps	%zmm2, %zmm0, %zmm0
	vmulps	%zmm7, %zmm7, %zmm2
	vsqrtps	%zmm0, %zmm0
	vaddps	%zmm9, %zmm0, %zmm9 {%k3}
	vmulps	%zmm9, %zmm9, %zmm0
	vpbroadcastd	(%r10), %zmm9
	vaddps	%zmm0, %zmm2, %zmm0
	vsqrtps	%zmm0, %zmm2
	vbroadcastss	(%r14), %zmm0
	vaddps	%zmm0, %zmm2, %zmm0 {%k3}
	vandps	%zmm8, %zmm0, %zmm2
	vcmpltps	%zmm14, %zmm0, %k6
	vmovaps	%zmm2, %zmm7 {%k3} {z}
	vcmpltps	(%r15){1to16}, %zmm7, %k4
	vpbroadcastd	(%rax), %zmm7
	vpcmpeqd	%zmm7, %zmm27, %k5
	vblendmps	(%r12){1to16}, %zmm4, %zmm10 {%k5}
	kandw	%k0, %k5, %k0
	vpcmpneqd	%zmm9, %zmm27, %k5 {%k6}
	vmovdqa32	%zmm9, %zmm27 {%k6}
	vcmpltps	%zmm0, %zmm13, %k6
	kandw	%k6, %k0, %k0
	korw	%k0, %k4, %k0
	vmovaps	%zmm10, %zmm29 {%k5}
	vcmpneq_oqps	%zmm3, %zmm13, %k5
	vpbroadcastd	%ecx, %zmm10
	vcmpnltps	%zmm0, %zmm13, %k7 {%k5}
	kandnw	%k3, %k0, %k5
	vpbroadcastd	(%r13), %zmm13
	vpcmpeqd	%zmm6, %zmm27, %k0 {%k6}
	kandw	%k4, %k3, %k3
	vmovaps	%zmm2, %zmm2 {%k5} {z}
	vmulps	%zmm2, %zmm29, %zmm2
	kandw	%k0, %k5, %k6
	kandnw	%k7, %k6, %k0
	vmovdqa32	%zmm7, %zmm27 {%k6}
	vaddps	%zmm2, %zmm12, %zmm2
	vcmpltps	%zmm26, %zmm2, %k6 {%k6}
	vpcmpeqd	%zmm13, %zmm10, %k4
	vmovaps	%zmm3, %zmm0 {%k6}
	vmovaps	%zmm26, %zmm2 {%k6}
	vcmpleps	%zmm25, %zmm2, %k6 {%k5}
	korw	%k4, %k3, %k4
	vblendmps	%zmm2, %zmm25, %zmm9 {%k6}
	knotw	%k6, %k5
	vmovdqa32	%zmm7, %zmm7 {%k6} {z}
	vmovdqa32	%zmm6, %zmm7 {%k3}
	vmovdqa32	%zmm7, %zmm28 {%k1}
	vmovaps	%zmm12, %zmm9 {%k3}
	korw	%k5, %k3, %k3
	vmovaps	%zmm9, %zmm31 {%k1}
	vpbroadcastd	%ecx, %zmm13 {%k3}
	korw	%k5, %k4, %k3
	incl	%ecx
	vmovdqa32	%zmm13, %zmm30 {%k1}
	kandnw	%k1, %k3, %k1
	vmovaps	%zmm0, %zmm13
	ktestw	%k2, %k1
	jne	.LBB0_8
	vpslld	$2, %zmm30, %zmm0
	vmovaps	%zmm31, %zmm24 {%k2}
	vpord	%zmm28, %zmm0, %zmm0 {%k2} {z}
	jmp	.LBB0_10
.Lfunc_end0:
	.size	camera, .Lfunc_end0-camera

	.type	float_const_signMask,@object
	.section	.lrodata,"al",@progbits
	.globl	float_const_signMask
	.p2align	2, 0x0
float_const_signMask:
	.long	2147483647
	.size	float_const_signMask, 4

	.ident	"Intel(R) oneAPI DPC++/C++ Compiler 2026.2.0 (2026.2.0.20261001)"
	.section	".note.GNU-stack","",@progbits
