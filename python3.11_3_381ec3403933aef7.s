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
	.long	0x80000000
.LCPI0_5:
	.long	0x40800008
.LCPI0_6:
	.long	0x3f800002
.LCPI0_7:
	.long	0x7f800000
.LCPI0_8:
	.long	0x40278dde
.LCPI0_9:
	.long	0x40800000
.LCPI0_10:
	.long	0xbf800000
.LCPI0_11:
	.long	0xc0878dde
.LCPI0_12:
	.long	0x39d1b717
.LCPI0_13:
	.long	2
.LCPI0_14:
	.long	0x3f000000
.LCPI0_15:
	.long	12
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
	subq	$768, %rsp
	movq	(%rsi), %r9
	movq	208(%rdi), %rax
	movq	8(%rsi), %rsi
	movq	200(%rdi), %rdx
	movslq	28(%rdi), %r8
	movslq	24(%rdi), %rcx
	imulq	%rax, %rsi
	addq	48(%rdi), %rsi
	imulq	%rdx, %r9
	addq	40(%rdi), %r9
	movq	%rcx, 48(%rsp)
	addq	%rsi, %rax
	movq	%r9, 64(%rsp)
	cmpq	%r8, %rax
	cmovgeq	%r8, %rax
	addq	%r9, %rdx
	cmpq	%rcx, %rdx
	movq	%rax, 72(%rsp)
	cmovgeq	%rcx, %rdx
	movq	%rdx, 120(%rsp)
	subq	%r9, %rdx
	testq	%rdx, %rdx
	jle	.LBB0_25
	movq	72(%rsp), %rax
	subq	%rsi, %rax
	testq	%rax, %rax
	jle	.LBB0_25
	movabsq	$9223372036854775792, %rcx
	movq	%r8, 88(%rsp)
	movq	8(%rdi), %rax
	movq	(%rdi), %r8
	movq	16(%rdi), %rdi
	movabsq	$.LCPI0_9, %rbx
	movabsq	$.LCPI0_10, %r14
	movabsq	$.LCPI0_11, %r15
	movabsq	$.LCPI0_12, %r12
	movabsq	$.LCPI0_14, %r13
	movq	%rsi, 56(%rsp)
	movq	%rdx, 112(%rsp)
	andq	%rdx, %rcx
	addq	64(%rsp), %rcx
	movq	%rax, 104(%rsp)
	movq	%rcx, 96(%rsp)
	cmpq	$16, %rdx
	jae	.LBB0_26
.LBB0_3:
	testb	$15, 112(%rsp)
	movq	56(%rsp), %rcx
	movq	88(%rsp), %rax
	je	.LBB0_25
	vcvtsi2ssl	48(%rsp), %xmm10, %xmm0
	movabsq	$.LCPI0_2, %rdx
	movabsq	$.LCPI0_3, %rsi
	vxorps	%xmm6, %xmm6, %xmm6
	vmovss	(%rdx), %xmm2
	movabsq	$.LCPI0_4, %rdx
	vmovss	(%rsi), %xmm3
	movabsq	$.LCPI0_5, %rsi
	vbroadcastss	(%rdx), %xmm4
	movabsq	$.LCPI0_7, %rdx
	vmovss	(%rsi), %xmm5
	vmovss	(%rdx), %xmm7
	vcvtsi2ss	%eax, %xmm10, %xmm1
	jmp	.LBB0_6
	.p2align	4
.LBB0_5:
	movq	56(%rsp), %rcx
	incq	%rcx
	cmpq	72(%rsp), %rcx
	je	.LBB0_25
.LBB0_6:
	leal	1(%rcx,%rcx), %eax
	movq	96(%rsp), %rdx
	movq	%rcx, 56(%rsp)
	vcvtsi2ss	%eax, %xmm8, %xmm8
	movq	48(%rsp), %rax
	imull	%ecx, %eax
	vsubss	%xmm8, %xmm1, %xmm8
	vdivss	%xmm1, %xmm8, %xmm8
	jmp	.LBB0_9
.LBB0_24:
	vmovaps	%xmm22, %xmm20
	.p2align	4
.LBB0_7:
	xorl	%esi, %esi
.LBB0_8:
	movq	104(%rsp), %r9
	vaddss	%xmm20, %xmm9, %xmm9
	leal	(%rax,%rdx), %ecx
	leal	(%rsi,%r11,4), %esi
	incq	%rdx
	movslq	%ecx, %rcx
	vmovss	%xmm9, (%r9,%rcx,4)
	movl	%esi, (%rdi,%rcx,4)
	cmpq	120(%rsp), %rdx
	je	.LBB0_5
.LBB0_9:
	leal	1(%rdx,%rdx), %esi
	vmulss	36(%r8), %xmm8, %xmm12
	vmovss	(%r8), %xmm13
	vmovss	4(%r8), %xmm14
	vmovss	8(%r8), %xmm15
	vpxord	%xmm27, %xmm27, %xmm27
	vcvtsi2ss	%esi, %xmm27, %xmm9
	vsubss	%xmm0, %xmm9, %xmm9
	vdivss	%xmm0, %xmm9, %xmm9
	vmulss	24(%r8), %xmm9, %xmm10
	vmulss	28(%r8), %xmm9, %xmm11
	vmulss	32(%r8), %xmm9, %xmm9
	vaddss	12(%r8), %xmm10, %xmm10
	vaddss	16(%r8), %xmm11, %xmm11
	vaddss	20(%r8), %xmm9, %xmm9
	vaddss	%xmm12, %xmm10, %xmm10
	vmulss	40(%r8), %xmm8, %xmm12
	vaddss	%xmm12, %xmm11, %xmm11
	vmulss	44(%r8), %xmm8, %xmm12
	vmulss	%xmm11, %xmm11, %xmm16
	vaddss	%xmm12, %xmm9, %xmm9
	vmulss	%xmm10, %xmm10, %xmm12
	vaddss	%xmm16, %xmm12, %xmm12
	vmulss	%xmm9, %xmm9, %xmm16
	vaddss	%xmm12, %xmm16, %xmm12
	vxorps	%xmm16, %xmm16, %xmm16
	vsubss	%xmm14, %xmm16, %xmm17
	vsubss	%xmm15, %xmm16, %xmm18
	vsqrtss	%xmm12, %xmm12, %xmm12
	vdivss	%xmm12, %xmm2, %xmm12
	vmulss	%xmm12, %xmm10, %xmm10
	vmulss	%xmm12, %xmm11, %xmm11
	vmulss	%xmm12, %xmm9, %xmm12
	vsubss	%xmm13, %xmm16, %xmm9
	vmulss	%xmm10, %xmm9, %xmm9
	vmulss	%xmm11, %xmm17, %xmm17
	vmulss	%xmm3, %xmm10, %xmm20
	vaddss	%xmm17, %xmm9, %xmm9
	vmulss	%xmm12, %xmm18, %xmm17
	vsubss	%xmm10, %xmm20, %xmm21
	vaddss	%xmm9, %xmm17, %xmm9
	vsubss	%xmm21, %xmm20, %xmm20
	vmulss	%xmm3, %xmm9, %xmm18
	vmulss	%xmm9, %xmm10, %xmm17
	vsubss	%xmm20, %xmm10, %xmm21
	vsubss	%xmm9, %xmm18, %xmm19
	vsubss	%xmm19, %xmm18, %xmm18
	vmulss	%xmm18, %xmm20, %xmm22
	vsubss	%xmm18, %xmm9, %xmm19
	vmulss	%xmm18, %xmm21, %xmm23
	vsubss	%xmm22, %xmm17, %xmm22
	vmulss	%xmm19, %xmm20, %xmm20
	vmulss	%xmm19, %xmm21, %xmm21
	vsubss	%xmm23, %xmm22, %xmm22
	vsubss	%xmm20, %xmm22, %xmm20
	vsubss	%xmm20, %xmm21, %xmm20
	vaddss	%xmm17, %xmm13, %xmm21
	vsubss	%xmm13, %xmm21, %xmm22
	vsubss	%xmm22, %xmm21, %xmm23
	vsubss	%xmm22, %xmm17, %xmm17
	vsubss	%xmm23, %xmm13, %xmm13
	vaddss	%xmm13, %xmm17, %xmm13
	vmulss	%xmm9, %xmm11, %xmm17
	vaddss	%xmm20, %xmm13, %xmm13
	vmulss	%xmm3, %xmm11, %xmm20
	vaddss	%xmm13, %xmm21, %xmm13
	vsubss	%xmm11, %xmm20, %xmm21
	vsubss	%xmm21, %xmm20, %xmm20
	vmulss	%xmm18, %xmm20, %xmm22
	vsubss	%xmm20, %xmm11, %xmm21
	vmulss	%xmm19, %xmm20, %xmm20
	vmulss	%xmm18, %xmm21, %xmm23
	vsubss	%xmm22, %xmm17, %xmm22
	vmulss	%xmm19, %xmm21, %xmm21
	vsubss	%xmm23, %xmm22, %xmm22
	vsubss	%xmm20, %xmm22, %xmm20
	vsubss	%xmm20, %xmm21, %xmm20
	vaddss	%xmm17, %xmm14, %xmm21
	vsubss	%xmm14, %xmm21, %xmm22
	vsubss	%xmm22, %xmm21, %xmm23
	vsubss	%xmm22, %xmm17, %xmm17
	vsubss	%xmm23, %xmm14, %xmm14
	vaddss	%xmm14, %xmm17, %xmm14
	vmulss	%xmm9, %xmm12, %xmm17
	vaddss	%xmm20, %xmm14, %xmm14
	vmulss	%xmm3, %xmm12, %xmm20
	vaddss	%xmm14, %xmm21, %xmm14
	vsubss	%xmm12, %xmm20, %xmm21
	vsubss	%xmm21, %xmm20, %xmm20
	vsubss	%xmm20, %xmm12, %xmm21
	vmulss	%xmm18, %xmm20, %xmm22
	vmulss	%xmm19, %xmm20, %xmm20
	vmulss	%xmm18, %xmm21, %xmm18
	vmulss	%xmm19, %xmm21, %xmm19
	vsubss	%xmm22, %xmm17, %xmm21
	vsubss	%xmm18, %xmm21, %xmm18
	vsubss	%xmm20, %xmm18, %xmm18
	vsubss	%xmm18, %xmm19, %xmm18
	vaddss	%xmm17, %xmm15, %xmm19
	vsubss	%xmm15, %xmm19, %xmm20
	vsubss	%xmm20, %xmm19, %xmm21
	vsubss	%xmm20, %xmm17, %xmm17
	vsubss	%xmm21, %xmm15, %xmm15
	vaddss	%xmm15, %xmm17, %xmm15
	vmulss	%xmm10, %xmm10, %xmm17
	vaddss	%xmm18, %xmm15, %xmm15
	vmulss	%xmm11, %xmm11, %xmm18
	vaddss	%xmm18, %xmm17, %xmm17
	vmulss	%xmm12, %xmm12, %xmm18
	vaddss	%xmm15, %xmm19, %xmm15
	vmulss	%xmm14, %xmm11, %xmm19
	vaddss	%xmm17, %xmm18, %xmm17
	vmulss	%xmm13, %xmm10, %xmm18
	vaddss	%xmm19, %xmm18, %xmm18
	vmulss	%xmm15, %xmm12, %xmm19
	vaddss	%xmm18, %xmm19, %xmm18
	vxorps	%xmm4, %xmm18, %xmm18
	vdivss	%xmm17, %xmm18, %xmm18
	vmulss	%xmm18, %xmm10, %xmm19
	vmulss	%xmm18, %xmm11, %xmm20
	vmulss	%xmm18, %xmm12, %xmm21
	vaddss	%xmm19, %xmm13, %xmm19
	vaddss	%xmm20, %xmm14, %xmm20
	vaddss	%xmm21, %xmm15, %xmm21
	vmulss	%xmm19, %xmm19, %xmm19
	vmulss	%xmm20, %xmm20, %xmm20
	vaddss	%xmm20, %xmm19, %xmm19
	vmulss	%xmm21, %xmm21, %xmm20
	vaddss	%xmm19, %xmm20, %xmm19
	vsubss	%xmm19, %xmm5, %xmm20
	vmovaps	%xmm2, %xmm19
	vucomiss	%xmm20, %xmm16
	ja	.LBB0_11
	vdivss	%xmm17, %xmm20, %xmm16
	movabsq	$.LCPI0_6, %rcx
	vsqrtss	%xmm16, %xmm16, %xmm16
	vmulss	(%rcx), %xmm16, %xmm16
	vsubss	%xmm16, %xmm18, %xmm19
	vaddss	%xmm16, %xmm18, %xmm16
.LBB0_11:
	vsubss	%xmm9, %xmm6, %xmm17
	vsubss	%xmm9, %xmm7, %xmm18
	xorl	%r11d, %r11d
	vmaxss	%xmm17, %xmm19, %xmm20
	vminss	%xmm18, %xmm16, %xmm22
	vucomiss	%xmm20, %xmm22
	jb	.LBB0_7
	vmulss	%xmm20, %xmm10, %xmm16
	movabsq	$.LCPI0_8, %rcx
	vmulss	%xmm20, %xmm11, %xmm17
	vmulss	%xmm20, %xmm12, %xmm18
	movl	$1, %esi
	vaddss	%xmm16, %xmm13, %xmm16
	vaddss	%xmm17, %xmm14, %xmm17
	vaddss	%xmm18, %xmm15, %xmm18
	vmulss	%xmm16, %xmm16, %xmm19
	vmovss	(%rcx), %xmm16
	vmulss	%xmm17, %xmm17, %xmm17
	vmulss	%xmm18, %xmm18, %xmm18
	vmulss	%xmm16, %xmm19, %xmm21
	vmulss	%xmm16, %xmm17, %xmm23
	vsubss	%xmm17, %xmm21, %xmm21
	vaddss	%xmm17, %xmm19, %xmm17
	vsubss	%xmm18, %xmm23, %xmm23
	vaddss	%xmm17, %xmm18, %xmm17
	vaddss	(%r14), %xmm17, %xmm17
	vmulss	%xmm23, %xmm21, %xmm21
	vmulss	%xmm16, %xmm18, %xmm23
	vsubss	%xmm19, %xmm23, %xmm23
	vmulss	%xmm21, %xmm23, %xmm21
	vmulss	(%rbx), %xmm21, %xmm21
	vmulss	%xmm17, %xmm17, %xmm17
	vmulss	(%r15), %xmm17, %xmm17
	vaddss	%xmm17, %xmm21, %xmm21
	vucomiss	%xmm6, %xmm21
	jne	.LBB0_13
	jnp	.LBB0_18
.LBB0_13:
	movl	$1, %r10d
	vmovaps	%xmm20, %xmm19
	.p2align	4
.LBB0_14:
	vucomiss	%xmm22, %xmm19
	movl	%r10d, %r11d
	jae	.LBB0_24
	vmovaps	%xmm19, %xmm18
	vcvtsi2ss	%r11d, %xmm12, %xmm19
	vmulss	(%r12), %xmm19, %xmm19
	vmovaps	%xmm21, %xmm17
	vaddss	%xmm19, %xmm20, %xmm19
	vminss	%xmm22, %xmm19, %xmm19
	vmulss	%xmm19, %xmm10, %xmm21
	vmulss	%xmm19, %xmm11, %xmm23
	vmulss	%xmm19, %xmm12, %xmm24
	vaddss	%xmm21, %xmm13, %xmm21
	vaddss	%xmm23, %xmm14, %xmm23
	vaddss	%xmm24, %xmm15, %xmm24
	vmulss	%xmm21, %xmm21, %xmm21
	vmulss	%xmm23, %xmm23, %xmm23
	vmulss	%xmm24, %xmm24, %xmm24
	vmulss	%xmm16, %xmm21, %xmm25
	vmulss	%xmm16, %xmm23, %xmm26
	vsubss	%xmm23, %xmm25, %xmm25
	vsubss	%xmm24, %xmm26, %xmm26
	vmulss	%xmm26, %xmm25, %xmm25
	vmulss	%xmm16, %xmm24, %xmm26
	vsubss	%xmm21, %xmm26, %xmm26
	vaddss	%xmm23, %xmm21, %xmm21
	vaddss	%xmm21, %xmm24, %xmm21
	vaddss	(%r14), %xmm21, %xmm21
	vmulss	%xmm25, %xmm26, %xmm25
	vmulss	(%rbx), %xmm25, %xmm25
	vmulss	%xmm21, %xmm21, %xmm21
	vmulss	(%r15), %xmm21, %xmm21
	vaddss	%xmm21, %xmm25, %xmm21
	vucomiss	%xmm6, %xmm21
	jne	.LBB0_16
	jnp	.LBB0_17
.LBB0_16:
	vucomiss	%xmm17, %xmm6
	leal	1(%r11), %r10d
	seta	%cl
	vucomiss	%xmm21, %xmm6
	setbe	%r9b
	cmpb	%r9b, %cl
	jne	.LBB0_14
.LBB0_17:
	incl	%r11d
	jmp	.LBB0_19
.LBB0_18:
	movl	$1, %r11d
	vmovaps	%xmm21, %xmm17
	vmovaps	%xmm20, %xmm19
	vmovaps	%xmm20, %xmm18
.LBB0_19:
	vucomiss	%xmm6, %xmm21
	jne	.LBB0_21
	jp	.LBB0_21
	vmovaps	%xmm19, %xmm20
	jmp	.LBB0_8
.LBB0_21:
	movl	$12, %r10d
	.p2align	4
.LBB0_22:
	vaddss	%xmm19, %xmm18, %xmm20
	vmulss	(%r13), %xmm20, %xmm22
	vcmpltss	%xmm6, %xmm17, %k1
	decl	%r10d
	vmulss	%xmm22, %xmm10, %xmm20
	vmulss	%xmm22, %xmm11, %xmm23
	vmulss	%xmm22, %xmm12, %xmm24
	vaddss	%xmm20, %xmm13, %xmm20
	vaddss	%xmm23, %xmm14, %xmm23
	vaddss	%xmm24, %xmm15, %xmm24
	vmulss	%xmm20, %xmm20, %xmm20
	vmulss	%xmm23, %xmm23, %xmm23
	vmulss	%xmm24, %xmm24, %xmm24
	vmulss	%xmm16, %xmm20, %xmm25
	vmulss	%xmm16, %xmm23, %xmm26
	vsubss	%xmm23, %xmm25, %xmm25
	vsubss	%xmm24, %xmm26, %xmm26
	vmulss	%xmm26, %xmm25, %xmm25
	vmulss	%xmm16, %xmm24, %xmm26
	vsubss	%xmm20, %xmm26, %xmm26
	vaddss	%xmm23, %xmm20, %xmm20
	vaddss	%xmm20, %xmm24, %xmm20
	vaddss	(%r14), %xmm20, %xmm20
	vmulss	%xmm25, %xmm26, %xmm25
	vmulss	(%rbx), %xmm25, %xmm25
	vmulss	%xmm20, %xmm20, %xmm20
	vmulss	(%r15), %xmm20, %xmm20
	vaddss	%xmm20, %xmm25, %xmm20
	vcmpnltss	%xmm6, %xmm20, %k0
	kxorw	%k0, %k1, %k1
	vmovss	%xmm20, %xmm17, %xmm17 {%k1}
	vmovss	%xmm21, %xmm20, %xmm20 {%k1}
	vmovss	%xmm22, %xmm18, %xmm18 {%k1}
	vmovss	%xmm19, %xmm22, %xmm22 {%k1}
	vmovaps	%xmm22, %xmm19
	vmovaps	%xmm20, %xmm21
	jne	.LBB0_22
	vsubss	%xmm20, %xmm17, %xmm11
	vsubss	%xmm18, %xmm22, %xmm10
	addl	$12, %r11d
	vdivss	%xmm11, %xmm17, %xmm11
	vmulss	%xmm11, %xmm10, %xmm10
	vaddss	%xmm10, %xmm18, %xmm20
	jmp	.LBB0_8
.LBB0_25:
	leaq	-40(%rbp), %rsp
	popq	%rbx
	popq	%r12
	popq	%r13
	popq	%r14
	popq	%r15
	popq	%rbp
	vzeroupper
	retq
.LBB0_26:
	movabsq	$.LCPI0_2, %rdx
	movq	64(%rsp), %rax
	vbroadcastss	(%rbx), %zmm7
	vbroadcastss	(%r14), %zmm8
	vbroadcastss	(%r15), %zmm9
	movq	104(%rsp), %r9
	movabsq	$.LCPI0_13, %r11
	vxorps	%xmm16, %xmm16, %xmm16
	vbroadcastss	(%rdx), %zmm1
	movabsq	$.LCPI0_3, %rdx
	vbroadcastss	(%rdx), %zmm3
	movabsq	$.LCPI0_5, %rdx
	vbroadcastss	(%rdx), %zmm4
	movabsq	$.LCPI0_6, %rdx
	vpbroadcastd	%eax, %zmm0
	movabsq	$.LCPI0_0, %rax
	vpaddd	%zmm0, %zmm0, %zmm0
	vpaddd	(%rax), %zmm0, %zmm2
	movabsq	$.LCPI0_1, %rax
	vpbroadcastd	(%rax), %zmm10
	vmovd	%xmm0, %eax
	vmovups	%zmm1, 640(%rsp)
	vmovups	%zmm3, 576(%rsp)
	vbroadcastss	(%rdx), %zmm3
	movabsq	$.LCPI0_7, %rdx
	vbroadcastss	(%rdx), %zmm1
	movabsq	$.LCPI0_8, %rdx
	vmovups	%zmm4, 512(%rsp)
	vbroadcastss	(%rdx), %zmm6
	vpextrd	$1, %xmm2, %edx
	vmovdqu64	%zmm2, 128(%rsp)
	subl	%eax, %edx
	movabsq	$.LCPI0_4, %rax
	shll	$4, %edx
	vpbroadcastd	%edx, %zmm2
	movq	56(%rsp), %rdx
	vmovdqu64	%zmm2, 256(%rsp)
	vmovups	%zmm3, 448(%rsp)
	vmovups	%zmm1, 384(%rsp)
	vcvtsi2ssl	88(%rsp), %xmm15, %xmm1
	vmovss	%xmm1, 80(%rsp)
	vcvtsi2ssl	48(%rsp), %xmm15, %xmm1
	vbroadcastss	%xmm1, %zmm0
	vpbroadcastd	(%rax), %zmm1
	vmovups	%zmm0, 320(%rsp)
	vmovdqu64	%zmm1, 192(%rsp)
	jmp	.LBB0_28
	.p2align	4
.LBB0_27:
	movq	%rcx, %rdx
	incq	%rdx
	cmpq	72(%rsp), %rdx
	je	.LBB0_3
.LBB0_28:
	vmovss	80(%rsp), %xmm1
	leal	1(%rdx,%rdx), %eax
	vmovdqu64	128(%rsp), %zmm18
	movq	64(%rsp), %rsi
	movq	%rdx, %rcx
	vcvtsi2ss	%eax, %xmm24, %xmm0
	movq	48(%rsp), %rax
	imull	%edx, %eax
	vsubss	%xmm0, %xmm1, %xmm0
	vdivss	%xmm1, %xmm0, %xmm0
	vmovss	%xmm0, 84(%rsp)
	jmp	.LBB0_30
	.p2align	4
.LBB0_29:
	vpaddd	256(%rsp), %zmm18, %zmm18
	vcmpneqps	%zmm16, %zmm11, %k3
	kandw	%k2, %k0, %k2
	leal	(%rax,%rsi), %edx
	addq	$16, %rsi
	vmovaps	%zmm27, %zmm1 {%k2}
	vmovdqa32	%zmm28, %zmm2 {%k2} {z}
	movslq	%edx, %rdx
	vmovaps	%zmm4, %zmm3 {%k3}
	vmovaps	%zmm3, %zmm1 {%k1}
	vaddps	%zmm1, %zmm19, %zmm0
	vpmovm2d	%k1, %zmm1
	vmovdqa32	%zmm29, %zmm5 {%k3}
	vmovdqa32	%zmm5, %zmm2 {%k1}
	vpsrld	$31, %zmm1, %zmm1
	vpslld	$2, %zmm2, %zmm2
	vmovups	%zmm0, (%r9,%rdx,4)
	vpord	%zmm1, %zmm2, %zmm0
	vmovdqu64	%zmm0, (%rdi,%rdx,4)
	cmpq	96(%rsp), %rsi
	je	.LBB0_27
.LBB0_30:
	vmovups	320(%rsp), %zmm2
	vpord	%zmm10, %zmm18, %zmm4
	vbroadcastss	(%r8), %zmm1
	vbroadcastss	4(%r8), %zmm3
	vbroadcastss	8(%r8), %zmm0
	vmovups	576(%rsp), %zmm12
	vxorps	%xmm29, %xmm29, %xmm29
	vcvtdq2ps	%zmm4, %zmm4
	vsubps	%zmm2, %zmm4, %zmm4
	vdivps	%zmm2, %zmm4, %zmm4
	vmovss	84(%rsp), %xmm2
	vmulss	36(%r8), %xmm2, %xmm15
	vmulps	24(%r8){1to16}, %zmm4, %zmm5
	vmulps	28(%r8){1to16}, %zmm4, %zmm11
	vmulps	32(%r8){1to16}, %zmm4, %zmm4
	vaddps	12(%r8){1to16}, %zmm5, %zmm5
	vaddps	16(%r8){1to16}, %zmm11, %zmm11
	vaddps	20(%r8){1to16}, %zmm4, %zmm4
	vbroadcastss	%xmm15, %zmm15
	vaddps	%zmm15, %zmm5, %zmm5
	vmulss	40(%r8), %xmm2, %xmm15
	vbroadcastss	%xmm15, %zmm15
	vaddps	%zmm15, %zmm11, %zmm11
	vmulss	44(%r8), %xmm2, %xmm15
	vmulps	%zmm5, %zmm5, %zmm2
	vmulps	%zmm11, %zmm11, %zmm19
	vbroadcastss	%xmm15, %zmm15
	vaddps	%zmm15, %zmm4, %zmm4
	vaddps	%zmm19, %zmm2, %zmm15
	vmulps	%zmm4, %zmm4, %zmm2
	vaddps	%zmm15, %zmm2, %zmm15
	vmovups	640(%rsp), %zmm2
	vsqrtps	%zmm15, %zmm15
	vdivps	%zmm15, %zmm2, %zmm15
	vmulps	%zmm15, %zmm11, %zmm21
	vmulps	%zmm15, %zmm5, %zmm20
	vmulps	%zmm15, %zmm4, %zmm22
	vxorps	%xmm11, %xmm11, %xmm11
	vsubss	%xmm1, %xmm11, %xmm4
	vsubss	%xmm3, %xmm11, %xmm5
	vsubss	%xmm0, %xmm11, %xmm11
	vbroadcastss	%xmm4, %zmm4
	vbroadcastss	%xmm5, %zmm5
	vbroadcastss	%xmm11, %zmm11
	vmulps	%zmm12, %zmm20, %zmm15
	vmulps	%zmm20, %zmm4, %zmm4
	vmulps	%zmm21, %zmm5, %zmm5
	vmulps	%zmm22, %zmm11, %zmm11
	vsubps	%zmm20, %zmm15, %zmm23
	vaddps	%zmm5, %zmm4, %zmm4
	vsubps	%zmm23, %zmm15, %zmm15
	vaddps	%zmm4, %zmm11, %zmm19
	vsubps	%zmm15, %zmm20, %zmm23
	vmulps	%zmm12, %zmm19, %zmm5
	vmulps	%zmm19, %zmm20, %zmm4
	vsubps	%zmm19, %zmm5, %zmm11
	vaddps	%zmm4, %zmm1, %zmm13
	vsubps	%zmm11, %zmm5, %zmm5
	vmulps	%zmm5, %zmm15, %zmm24
	vsubps	%zmm5, %zmm19, %zmm11
	vmulps	%zmm5, %zmm23, %zmm25
	vsubps	%zmm24, %zmm4, %zmm24
	vmulps	%zmm11, %zmm15, %zmm15
	vmulps	%zmm11, %zmm23, %zmm23
	vsubps	%zmm25, %zmm24, %zmm24
	vsubps	%zmm15, %zmm24, %zmm15
	vsubps	%zmm1, %zmm13, %zmm24
	vsubps	%zmm24, %zmm13, %zmm25
	vsubps	%zmm24, %zmm4, %zmm4
	vsubps	%zmm15, %zmm23, %zmm15
	vsubps	%zmm25, %zmm1, %zmm1
	vaddps	%zmm1, %zmm4, %zmm1
	vmulps	%zmm12, %zmm21, %zmm4
	vsubps	%zmm21, %zmm4, %zmm14
	vaddps	%zmm15, %zmm1, %zmm1
	vsubps	%zmm14, %zmm4, %zmm4
	vaddps	%zmm1, %zmm13, %zmm23
	vmulps	%zmm19, %zmm21, %zmm1
	vmulps	%zmm5, %zmm4, %zmm24
	vsubps	%zmm4, %zmm21, %zmm15
	vmulps	%zmm11, %zmm4, %zmm4
	vaddps	%zmm1, %zmm3, %zmm13
	vmulps	%zmm5, %zmm15, %zmm25
	vsubps	%zmm24, %zmm1, %zmm24
	vmulps	%zmm11, %zmm15, %zmm15
	vsubps	%zmm25, %zmm24, %zmm24
	vsubps	%zmm4, %zmm24, %zmm4
	vsubps	%zmm3, %zmm13, %zmm24
	vsubps	%zmm24, %zmm13, %zmm25
	vsubps	%zmm24, %zmm1, %zmm1
	vsubps	%zmm4, %zmm15, %zmm4
	vsubps	%zmm25, %zmm3, %zmm3
	vaddps	%zmm3, %zmm1, %zmm1
	vmulps	%zmm12, %zmm22, %zmm3
	vaddps	%zmm4, %zmm1, %zmm1
	vaddps	%zmm1, %zmm13, %zmm24
	vsubps	%zmm22, %zmm3, %zmm13
	vmulps	%zmm19, %zmm22, %zmm1
	vsubps	%zmm13, %zmm3, %zmm3
	vmulps	%zmm5, %zmm3, %zmm15
	vsubps	%zmm3, %zmm22, %zmm4
	vmulps	%zmm11, %zmm3, %zmm3
	vmulps	%zmm5, %zmm4, %zmm5
	vsubps	%zmm15, %zmm1, %zmm12
	vmulps	%zmm11, %zmm4, %zmm4
	vsubps	%zmm5, %zmm12, %zmm5
	vaddps	%zmm1, %zmm0, %zmm12
	vsubps	%zmm3, %zmm5, %zmm3
	vsubps	%zmm0, %zmm12, %zmm5
	vsubps	%zmm5, %zmm12, %zmm11
	vsubps	%zmm5, %zmm1, %zmm1
	vsubps	%zmm3, %zmm4, %zmm3
	vmulps	%zmm23, %zmm20, %zmm4
	vsubps	%zmm11, %zmm0, %zmm0
	vaddps	%zmm0, %zmm1, %zmm0
	vmulps	%zmm21, %zmm21, %zmm1
	vaddps	%zmm3, %zmm0, %zmm0
	vmulps	%zmm20, %zmm20, %zmm3
	vaddps	%zmm0, %zmm12, %zmm25
	vaddps	%zmm1, %zmm3, %zmm0
	vmulps	%zmm22, %zmm22, %zmm3
	vaddps	%zmm0, %zmm3, %zmm0
	vmulps	%zmm24, %zmm21, %zmm3
	vmulps	%zmm25, %zmm22, %zmm5
	vaddps	%zmm3, %zmm4, %zmm1
	vaddps	%zmm1, %zmm5, %zmm1
	vxorps	192(%rsp), %zmm1, %zmm1
	vdivps	%zmm0, %zmm1, %zmm1
	vmulps	%zmm1, %zmm20, %zmm3
	vmulps	%zmm1, %zmm21, %zmm4
	vmulps	%zmm1, %zmm22, %zmm5
	vaddps	%zmm3, %zmm23, %zmm3
	vaddps	%zmm4, %zmm24, %zmm4
	vaddps	%zmm5, %zmm25, %zmm5
	vmulps	%zmm3, %zmm3, %zmm3
	vmulps	%zmm4, %zmm4, %zmm4
	vmulps	%zmm5, %zmm5, %zmm11
	vmovups	512(%rsp), %zmm5
	vaddps	%zmm4, %zmm3, %zmm3
	vaddps	%zmm3, %zmm11, %zmm3
	vsubps	%zmm3, %zmm5, %zmm3
	vdivps	%zmm0, %zmm3, %zmm0
	vcmpnltps	%zmm29, %zmm3, %k1
	vmovaps	%zmm2, %zmm3
	vsubps	%zmm19, %zmm29, %zmm2
	vsqrtps	%zmm0, %zmm0
	vmulps	448(%rsp), %zmm0, %zmm0
	vsubps	%zmm0, %zmm1, %zmm3 {%k1}
	vaddps	%zmm0, %zmm1, %zmm0 {%k1} {z}
	vmaxps	%zmm2, %zmm3, %zmm1
	vmovups	384(%rsp), %zmm2
	vsubps	%zmm19, %zmm2, %zmm4
	vmulps	%zmm1, %zmm21, %zmm2
	vminps	%zmm4, %zmm0, %zmm27
	vmulps	%zmm1, %zmm20, %zmm0
	vaddps	%zmm2, %zmm24, %zmm3
	vmulps	%zmm1, %zmm22, %zmm4
	vcmpleps	%zmm27, %zmm1, %k1
	vaddps	%zmm0, %zmm23, %zmm0
	vaddps	%zmm4, %zmm25, %zmm4
	vmulps	%zmm3, %zmm3, %zmm3
	vmulps	%zmm0, %zmm0, %zmm0
	vmulps	%zmm4, %zmm4, %zmm4
	vmulps	%zmm6, %zmm3, %zmm11
	vmulps	%zmm6, %zmm0, %zmm5
	vsubps	%zmm4, %zmm11, %zmm11
	vmulps	%zmm6, %zmm4, %zmm2
	vsubps	%zmm3, %zmm5, %zmm5
	vmulps	%zmm11, %zmm5, %zmm5
	vsubps	%zmm0, %zmm2, %zmm11
	vaddps	%zmm3, %zmm0, %zmm0
	vaddps	%zmm0, %zmm4, %zmm0
	vmulps	%zmm5, %zmm11, %zmm5
	vaddps	%zmm8, %zmm0, %zmm0
	vmulps	%zmm7, %zmm5, %zmm5
	vmulps	%zmm0, %zmm0, %zmm0
	vmulps	%zmm9, %zmm0, %zmm0
	vaddps	%zmm0, %zmm5, %zmm15
	vcmpneqps	%zmm29, %zmm15, %k2
	kandw	%k2, %k1, %k0
	kortestw	%k0, %k0
	je	.LBB0_34
	movl	$2, %edx
	vmovaps	%zmm15, %zmm30
	vmovaps	%zmm1, %zmm26
	.p2align	4
.LBB0_32:
	leal	-1(%rdx), %r10d
	kandw	%k2, %k0, %k3
	vmovaps	%zmm26, %zmm31 {%k2}
	vpbroadcastd	%edx, %zmm11 {%k2}
	incl	%edx
	vcvtsi2ss	%r10d, %xmm10, %xmm13
	vmulss	(%r12), %xmm13, %xmm13
	vcmpnleps	%zmm26, %zmm27, %k3 {%k3}
	vmovaps	%zmm30, %zmm0 {%k2}
	vpbroadcastd	%r10d, %zmm28 {%k2}
	vmovdqa32	%zmm27, %zmm26 {%k3} {z}
	vbroadcastss	%xmm13, %zmm13
	vaddps	%zmm13, %zmm1, %zmm13
	vmovdqa32	%zmm13, %zmm13 {%k3} {z}
	vcmpltps	%zmm26, %zmm13, %k4
	vmovdqa32	%zmm13, %zmm26 {%k4}
	vmulps	%zmm26, %zmm20, %zmm13
	vmulps	%zmm26, %zmm21, %zmm14
	vmulps	%zmm26, %zmm22, %zmm2
	vcmpltps	%zmm16, %zmm30, %k4
	vmovaps	%zmm26, %zmm4 {%k2}
	vaddps	%zmm13, %zmm23, %zmm13
	vaddps	%zmm14, %zmm24, %zmm14
	vaddps	%zmm2, %zmm25, %zmm2
	vmulps	%zmm13, %zmm13, %zmm13
	vmulps	%zmm14, %zmm14, %zmm14
	vmulps	%zmm2, %zmm2, %zmm2
	vmulps	%zmm6, %zmm13, %zmm12
	vmulps	%zmm6, %zmm14, %zmm17
	vsubps	%zmm14, %zmm12, %zmm12
	vsubps	%zmm2, %zmm17, %zmm17
	vmulps	%zmm17, %zmm12, %zmm12
	vmulps	%zmm6, %zmm2, %zmm17
	vsubps	%zmm13, %zmm17, %zmm17
	vaddps	%zmm14, %zmm13, %zmm13
	vaddps	%zmm13, %zmm2, %zmm2
	vmulps	%zmm12, %zmm17, %zmm12
	vaddps	%zmm8, %zmm2, %zmm2
	vmulps	%zmm7, %zmm12, %zmm12
	vmulps	%zmm2, %zmm2, %zmm2
	vmulps	%zmm9, %zmm2, %zmm2
	vaddps	%zmm2, %zmm12, %zmm30
	vpbroadcastd	(%r11), %zmm12
	vcmpneqps	%zmm16, %zmm30, %k5
	vmovaps	%zmm30, %zmm3 {%k2}
	knotw	%k5, %k6
	vmovdqa32	%zmm12, %zmm2 {%k6} {z}
	vpblendmd	%zmm2, %zmm10, %zmm2 {%k3}
	vcmpnltps	%zmm16, %zmm30, %k6
	vmovdqa32	%zmm2, %zmm5 {%k2}
	kandw	%k3, %k2, %k2
	kxorw	%k6, %k4, %k4
	kandw	%k5, %k2, %k2
	kandw	%k4, %k2, %k2
	ktestw	%k0, %k2
	jne	.LBB0_32
	vpcmpeqd	%zmm10, %zmm5, %k2
	vpcmpneqd	%zmm10, %zmm5, %k3
	jmp	.LBB0_35
	.p2align	4
.LBB0_34:
	kxorw	%k0, %k0, %k2
	vpxord	%xmm28, %xmm28, %xmm28
	vxorps	%xmm31, %xmm31, %xmm31
	vxorps	%xmm0, %xmm0, %xmm0
	vxorps	%xmm11, %xmm11, %xmm11
	vxorps	%xmm3, %xmm3, %xmm3
	vxorps	%xmm4, %xmm4, %xmm4
	kxorw	%k0, %k0, %k3
.LBB0_35:
	kandw	%k3, %k0, %k3
	vcmpeqps	%zmm29, %zmm15, %k1 {%k1}
	vpblendmd	%zmm11, %zmm10, %zmm5 {%k3}
	vblendmps	%zmm3, %zmm15, %zmm11 {%k3}
	vblendmps	%zmm4, %zmm1, %zmm3 {%k3}
	vxorps	%xmm4, %xmm4, %xmm4
	vcmpneqps	%zmm29, %zmm11, %k4
	korw	%k3, %k1, %k1
	ktestw	%k4, %k1
	je	.LBB0_29
	vblendmps	%zmm31, %zmm1, %zmm4 {%k3}
	movl	$12, %edx
	vmovaps	%zmm0, %zmm15 {%k3}
	vmovaps	%zmm3, %zmm0
	vmovaps	%zmm11, %zmm26
	.p2align	4
.LBB0_37:
	vaddps	%zmm0, %zmm4, %zmm12
	vmulps	(%r13){1to16}, %zmm12, %zmm12
	vmovaps	%zmm26, %zmm2
	vcmpltps	%zmm16, %zmm15, %k3
	decl	%edx
	vmulps	%zmm12, %zmm20, %zmm13
	vmulps	%zmm12, %zmm21, %zmm14
	vmulps	%zmm12, %zmm22, %zmm17
	vaddps	%zmm13, %zmm23, %zmm13
	vaddps	%zmm14, %zmm24, %zmm14
	vaddps	%zmm17, %zmm25, %zmm17
	vmulps	%zmm13, %zmm13, %zmm13
	vmulps	%zmm14, %zmm14, %zmm14
	vmulps	%zmm17, %zmm17, %zmm17
	vmulps	%zmm6, %zmm13, %zmm26
	vmulps	%zmm6, %zmm14, %zmm29
	vmulps	%zmm6, %zmm17, %zmm30
	vsubps	%zmm14, %zmm26, %zmm26
	vsubps	%zmm17, %zmm29, %zmm29
	vmulps	%zmm29, %zmm26, %zmm26
	vsubps	%zmm13, %zmm30, %zmm29
	vaddps	%zmm14, %zmm13, %zmm13
	vaddps	%zmm13, %zmm17, %zmm13
	vmulps	%zmm26, %zmm29, %zmm26
	vaddps	%zmm8, %zmm13, %zmm13
	vmulps	%zmm7, %zmm26, %zmm26
	vmulps	%zmm13, %zmm13, %zmm13
	vmulps	%zmm9, %zmm13, %zmm13
	vaddps	%zmm13, %zmm26, %zmm26
	vcmpnltps	%zmm16, %zmm26, %k4
	kxorw	%k4, %k3, %k3
	vblendmps	%zmm0, %zmm12, %zmm0 {%k3}
	vmovaps	%zmm26, %zmm15 {%k3}
	vmovaps	%zmm2, %zmm26 {%k3}
	vmovaps	%zmm12, %zmm4 {%k3}
	jne	.LBB0_37
	vsubps	%zmm26, %zmm15, %zmm2
	movabsq	$.LCPI0_15, %rdx
	vsubps	%zmm4, %zmm0, %zmm0
	vpaddd	(%rdx){1to16}, %zmm5, %zmm29
	vdivps	%zmm2, %zmm15, %zmm2
	vmulps	%zmm2, %zmm0, %zmm0
	vaddps	%zmm0, %zmm4, %zmm4
	jmp	.LBB0_29
.Lfunc_end0:
	.size	camera, .Lfunc_end0-camera

	.ident	"Intel(R) oneAPI DPC++/C++ Compiler 2026.2.0 (2026.2.0.20261001)"
	.section	".note.GNU-stack","",@progbits
